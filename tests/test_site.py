"""The documentation site in a browser: every page, wide and on a telephone, light and dark; and what Start leads to."""

from __future__ import annotations

import functools
import json
import queue
import re
import shutil
import subprocess
import threading
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


def pages(site: Path) -> list[str]:
    everything = (path.relative_to(site).as_posix() for path in site.rglob("*.html"))
    return sorted(name for name in everything if name not in (OF_A_SERVER, LOOKER) and not name.startswith("assets/"))


def looked_at(site: Path, width: int, scheme: str, scratch: Path) -> tuple[dict[str, dict[str, Any]], list[str], str]:
    """What a browser finds in each page, what its console says, and the site's address meanwhile."""
    replaced = {"NAMES": json.dumps(pages(site)), "WIDTH": width, "WORDS": WORDS, "NARROW": NARROW}
    look = functools.reduce(lambda text, item: text.replace(item[0], str(item[1])), replaced.items(), LOOK)
    (site / LOOKER).write_text(look, encoding="utf-8")
    options = [
        "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-background-networking",
        "--disable-sync", "--disable-component-update", "--enable-logging=stderr",
        f"--user-data-dir={scratch / 'profile'}", f"--blink-settings=preferredColorScheme={SCHEMES[scheme]}",
    ]  # fmt: skip
    with Desk(("127.0.0.1", 0), functools.partial(Clerk, directory=str(site))) as desk:
        desk.told = queue.Queue()
        threading.Thread(target=desk.serve_forever, daemon=True).start()
        address = f"http://127.0.0.1:{desk.server_port}/"
        with (scratch / "log").open("wb") as log:
            browser = subprocess.Popen([str(BROWSER), *options, f"{address}{LOOKER}"], stderr=log)
            try:
                found = desk.told.get(timeout=120)
            finally:
                browser.terminate()
                browser.wait()
                desk.shutdown()
    console = re.findall(".*CONSOLE.*", (scratch / "log").read_text(encoding="utf-8", errors="replace"))
    return found, console, address


@pytest.mark.full
@pytest.mark.skipif(BROWSER is None, reason="neither chromium nor google-chrome is installed")
@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("screen", WIDTHS)
def test_pages_in_a_browser(site: Path, screen: str, scheme: str, tmp_path: Path) -> None:
    found, console, address = looked_at(site, WIDTHS[screen], scheme, tmp_path)
    assert console == []
    assert len(found) == len(pages(site)) > 25
    assert {name: one["width"] for name, one in found.items() if one["width"] > WIDTHS[screen]} == {}
    schemes = {one["scheme"] for one in found.values() if "scheme" in one}  # pages beside mkdocs' have none
    assert schemes == {"slate" if scheme == "dark" else "default"}
    assert {name: one["narrow"] for name, one in found.items() if one["narrow"]} == {}
    assert {name: one["blank"] for name, one in found.items() if one["blank"]} == {}
    assert any(one["asked"] for one in found.values())
    assert {url for one in found.values() for url in one["asked"] if not url.startswith((address, "data:"))} == set()


@pytest.mark.full
@pytest.mark.skipif(BROWSER is None, reason="neither chromium nor google-chrome is installed")
def test_what_is_wrong_with_a_page_is_seen(tmp_path: Path) -> None:
    (tmp_path / "site").mkdir()
    cell = f"<article><table><tr><td style='width: 9px'>{'word ' * (WORDS + 1)}</td></tr></table></article>"
    wrong = "<div style='width: 2000px'>.</div><script>console.error('wrong')</script><img src='none.png'>"
    outside = '<script src="https://example.invalid/a.js"></script>'
    (tmp_path / "site" / "page.html").write_text(f"<body>{cell}{wrong}{outside}", encoding="utf-8")
    found, console, _ = looked_at(tmp_path / "site", WIDTHS["telephone"], "light", tmp_path)
    page = found["page.html"]
    assert page["width"] > 1000 and len(page["narrow"]) == 1 and page["blank"][0].endswith("/none.png")
    assert "https://example.invalid/a.js" in page["asked"] and any("wrong" in line for line in console)


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
