"""One module a command: options in, exit status out. What takes long to import is imported where it is used."""
