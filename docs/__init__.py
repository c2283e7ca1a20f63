"""The documentation: its pages, and what mkdocs needs to make a site of them."""
