"""The documentation site in a browser: every page, wide and on a telephone, light and dark; and what Start leads to."""

from __future__ import annotations

import functools
import json
import queue
import re
import shutil
import subprocess
import threading
from collections.abc import Iterator
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import lxml.html
import pytest

from tests.test_documentation import site

__all__ = ["site"]

BROWSER = shutil.which("chromium") or shutil.which("google-chrome")
WIDTHS = {"telephone": 390, "desktop": 1280}  # CSS pixels
SCHEMES = {"dark": 0, "light": 1}  # as Chromium's setting has them
OF_A_SERVER = "404.html"  # its addresses begin at the server's root
LOOKER = "look.html"  # which looks at the others
WORDS, NARROW = 12, 90  # a cell of so many words is wider than so many pixels

# Opens every page in a frame of the width asked for, one after the other, and hands in what is wrong with each.
LOOK = """<meta charset="utf-8"><link rel="icon" href="data:,"><body><script>
(async () => {
  const found = {};
  for (const name of NAMES) {
    const frame = document.createElement("iframe");
    frame.style = "border: 0; height: 800px; width: WIDTHpx";
    const loaded = new Promise((resolve) => (frame.onload = resolve));
    frame.src = name;
    document.body.appendChild(frame);
    await loaded;
    const page = frame.contentDocument;
    const long = (cell) => cell.innerText.split(/\\s+/).length > WORDS;
    const cells = [...page.querySelectorAll("article td")].filter(long);
    found[name] = {
      width: page.documentElement.scrollWidth,
      scheme: page.body.dataset.mdColorScheme,
      narrow: cells.filter((cell) => cell.offsetWidth < NARROW).map((cell) => cell.innerText),
      blank: [...page.images].filter((image) => image.complete && !image.naturalWidth).map((image) => image.src),
      asked: frame.contentWindow.performance.getEntriesByType("resource").map((entry) => entry.name),
    };
    frame.remove();
  }
  await fetch("told", { method: "POST", body: JSON.stringify(found) });
})();
</script>"""


class Desk(ThreadingHTTPServer):
    """Gives out the site, and takes what is found: frames of pages from the disk may not be looked into."""

    told: queue.Queue[dict[str, dict[str, Any]]]


class Clerk(SimpleHTTPRequestHandler):
    server: Desk

    def do_POST(self) -> None:
        self.server.told.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.send_response(204)
        self.end_headers()

    def log_message(self, format: str, *args: object) -> None:
        """Say nothing."""


@pytest.fixture(scope="module")
def desk(site: Path) -> Iterator[Desk]:
    with Desk(("127.0.0.1", 0), functools.partial(Clerk, directory=str(site))) as server:
        server.told = queue.Queue()
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield server
        server.shutdown()


def pages(site: Path) -> list[str]:
    everything = (path.relative_to(site).as_posix() for path in site.rglob("*.html"))
    return sorted(name for name in everything if name not in (OF_A_SERVER, LOOKER) and not name.startswith("assets/"))


def looked_at(address: str, desk: Desk, scheme: str, folder: Path) -> tuple[dict[str, dict[str, Any]], list[str]]:
    """What a browser found, and what its console says."""
    options = [
        "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
        "--disable-sync", "--disable-component-update", "--enable-logging=stderr",
        f"--user-data-dir={folder / 'profile'}", f"--blink-settings=preferredColorScheme={SCHEMES[scheme]}",
    ]  # fmt: skip
    with (folder / "log").open("wb") as log, subprocess.Popen([str(BROWSER), *options, address], stderr=log) as browser:
        try:
            found = desk.told.get(timeout=120)
        finally:
            browser.terminate()
    return found, re.findall(".*CONSOLE.*", (folder / "log").read_text(encoding="utf-8", errors="replace"))


@pytest.mark.full
@pytest.mark.skipif(BROWSER is None, reason="neither chromium nor google-chrome is installed")
@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("screen", WIDTHS)
def test_pages_in_a_browser(site: Path, desk: Desk, screen: str, scheme: str, tmp_path: Path) -> None:
    names, address = pages(site), f"http://127.0.0.1:{desk.server_port}/"
    replaced = {"NAMES": json.dumps(names), "WIDTH": WIDTHS[screen], "WORDS": WORDS, "NARROW": NARROW}
    look = functools.reduce(lambda text, item: text.replace(item[0], str(item[1])), replaced.items(), LOOK)
    (site / LOOKER).write_text(look, encoding="utf-8")
    found, console = looked_at(f"{address}{LOOKER}", desk, scheme, tmp_path)
    assert console == []
    assert len(found) == len(names) > 25
    assert {name: one["width"] for name, one in found.items() if one["width"] > WIDTHS[screen]} == {}
    schemes = {one["scheme"] for one in found.values() if "scheme" in one}  # pages beside mkdocs' have none
    assert schemes == {"slate" if scheme == "dark" else "default"}
    assert {name: one["narrow"] for name, one in found.items() if one["narrow"]} == {}
    assert {name: one["blank"] for name, one in found.items() if one["blank"]} == {}
    assert any(one["asked"] for one in found.values())
    assert {url for one in found.values() for url in one["asked"] if not url.startswith((address, "data:"))} == set()


QUESTIONS = {
    "what case ii is": ("model.html#case-ii", "The one that all of the paper's runs start from"),
    "what D is": ("model.html#steady-braking", "D is the steady compression of the drawbar"),
    "how to brake with one's own torque history": ("script.html#your-own-torque-history", "hitch.run(profile="),
    "how to put the hitch into one's simulator": ("use.html#get-the-file", "Trailer.fmu"),
    "how to choose C for a trailer of 750 kg": ("design.html#a-trailer-of-750-kg", "A damper of some 1076 N.s/m"),
}


def links(page: Path) -> set[str]:
    """What a page's text and its navigation link."""
    return {str(link).removeprefix("./") for link in lxml.html.parse(str(page)).xpath("//a/@href")}


@pytest.mark.full
@pytest.mark.parametrize("question", QUESTIONS)
def test_start_answers_within_two_clicks(site: Path, question: str) -> None:
    target, words = QUESTIONS[question]
    name, _, anchor = target.partition("#")
    one_click = links(site / "index.html")
    beyond = {link.partition("#")[0] for link in one_click if link.partition("#")[0] in pages(site)}
    two_clicks = {f"{page}{link}" if link.startswith("#") else link for page in beyond for link in links(site / page)}
    assert target in one_click | two_clicks
    (heading,) = lxml.html.parse(str(site / name)).xpath(f"//article//*[@id='{anchor}']")
    text = ""
    for element in heading.itersiblings():
        if element.tag <= heading.tag and re.fullmatch("h[1-6]", element.tag):
            break
        text += " " + element.text_content()
    assert words in " ".join(text.split())
