"""One page, served to this machine's browsers alone."""

from __future__ import annotations

from collections.abc import Callable
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer


def serve(page: bytes, ready: Callable[[str], object]) -> None:
    """Serve an HTML page from loopback, on a free port, until interrupted; `ready` is told its address first."""

    class OnePage(BaseHTTPRequestHandler):
        def do_GET(self) -> None:  # the name that http.server looks for
            """The page at /; there is nothing else."""
            if self.path.partition("?")[0] != "/":
                self.send_error(404)
                return
            self.send_response(200)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(page)))
            self.send_header("Cache-Control", "no-store")  # another page may have the port next time
            self.end_headers()
            self.wfile.write(page)

        def log_message(self, format: str, *args: object) -> None:
            """Nothing: who looks at the page sees that it has come."""

    with ThreadingHTTPServer(("127.0.0.1", 0), OnePage) as server:
        ready(f"http://127.0.0.1:{server.server_port}/")
        server.serve_forever()
