"""One file for several processors: the universal ("fat") binary of macOS.

Format: mach-o/fat.h of Apple's XNU: a big-endian header {magic, number}, then for each processor {cputype, cpusubtype,
offset, size, alignment as a power of two}, then the Mach-O files themselves, each at its offset.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence

FAT_MAGIC = 0xCAFEBABE
MH_MAGIC_64 = 0xFEEDFACF
ALIGNMENT = 14  # pages of 16 KiB, as on Apple silicon
_HEADER = struct.Struct(">2I")
_ENTRY = struct.Struct(">5I")


def universal(libraries: Sequence[bytes]) -> bytes:
    """The fat binary of 64-bit Mach-O ``libraries``, one for each processor; a single file is returned as it is."""
    if len(libraries) == 1:
        return libraries[0]
    processors = [struct.unpack_from("<3I", library) for library in libraries]
    if any(magic != MH_MAGIC_64 for magic, _, _ in processors):
        raise ValueError("not a 64-bit Mach-O file")
    if len(set(processors)) < len(libraries):
        raise ValueError("two libraries for one processor")
    entries = b""
    content = bytearray(_HEADER.size + _ENTRY.size * len(libraries))
    for (_, processor, variant), library in sorted(zip(processors, libraries, strict=True)):
        content += bytes(-len(content) % 2**ALIGNMENT)
        entries += _ENTRY.pack(processor, variant, len(content), len(library), ALIGNMENT)
        content += library
    header = _HEADER.pack(FAT_MAGIC, len(libraries)) + entries
    return header + bytes(content[len(header) :])
