# SPDX-License-Identifier: BSD-3-Clause
"""The blocks of Python on the pages of the documentation, as programs."""

import pathlib
import re

import scene

PAGES = ("share/doc/python.md", "share/doc/tutorials/python.md")


def write_blocks(folder: pathlib.Path) -> list[pathlib.Path]:
    """A program for each page: its blocks marked `python`, in order."""
    programs = []
    for page in PAGES:
        text = (scene.ROOT / page).read_text()
        blocks = re.findall(r"(?ms)^```python\n(.*?)^```$", text)
        program = folder / (page.replace("/", "_").removesuffix(".md") + ".py")
        program.write_text("".join(blocks))
        programs.append(program)
    return programs
