"""Names of platforms, and one file for two processors."""

from __future__ import annotations

import struct

import pytest

from fmu_build.errors import BuildError
from fmu_build.fmu.compile import PLATFORMS, WASM, host_platform, named_platforms
from fmu_build.fmu.fat_mach_o import universal

X86_64, ARM64 = 0x01000007, 0x0100000C  # mach/machine.h: CPU_TYPE_X86_64, CPU_TYPE_ARM64


def mach_o(processor: int, size: int) -> bytes:
    """The beginning of a mach_header_64 and as many bytes as asked for."""
    return struct.pack("<3I", 0xFEEDFACF, processor, 3).ljust(size, b"\x5a")


def test_the_fat_header_is_as_in_mach_o_fat_h() -> None:
    intel, arm = mach_o(X86_64, 20001), mach_o(ARM64, 777)
    fat = universal([arm, intel])
    assert struct.unpack_from(">2I", fat) == (0xCAFEBABE, 2)
    entries = [struct.unpack_from(">5I", fat, 8 + 20 * i) for i in range(2)]
    assert entries == [(X86_64, 3, 16384, 20001, 14), (ARM64, 3, 49152, 777, 14)]
    for (_, _, offset, size, alignment), library in zip(entries, (intel, arm), strict=True):
        assert offset % 2**alignment == 0
        assert fat[offset : offset + size] == library
    assert len(fat) == 49152 + 777 and not any(fat[48:16384]) and not any(fat[16384 + 20001 : 49152])


def test_what_is_not_for_two_processors() -> None:
    assert universal([b"\x7fELF"]) == b"\x7fELF"
    with pytest.raises(ValueError, match="not a 64-bit Mach-O"):
        universal([mach_o(ARM64, 99), b"\x7fELF".ljust(99)])
    with pytest.raises(ValueError, match="one processor"):
        universal([mach_o(ARM64, 99), mach_o(ARM64, 100)])


def test_names_of_platforms() -> None:
    host = host_platform()
    assert host.zig_target is None and host.fmi3_folder == host.name
    assert named_platforms(["host"]) == (host,)
    assert named_platforms(["all"]) == tuple(PLATFORMS.values()) == named_platforms([*PLATFORMS, "host"])
    windows = PLATFORMS["x86_64-windows"]
    assert named_platforms(["x86_64-windows"]) == (windows,)
    assert set(named_platforms(["host", "x86_64-windows"])) == {PLATFORMS[host.name], windows}
    assert named_platforms(["wasm"]) == (WASM,) and WASM not in named_platforms(["all"])
    assert named_platforms(["wasm", "all"]) == (*PLATFORMS.values(), WASM)
    for wrong in (["vax"], []):
        with pytest.raises(BuildError) as caught:
            named_platforms(wrong)
        assert "\n" not in str(caught.value)
    with pytest.raises(BuildError, match=r"'vax'.*allowed are host, all, x86_64-linux, .*, wasm$"):
        named_platforms(["host", "vax"])
