#!/usr/bin/env python3
"""Fails unless each link of a built site leads to a file and an anchor that exist, and no page needs another host.

Links to other hosts are not followed: a test must not depend on them. Usage: check_links.py FOLDER
"""

import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

folder = Path(sys.argv[1]).resolve()
# Doxygen links to the list of nested classes also where all are private, TypeDoc to derived types in no hierarchy.
FLAWS_OF_TOOLS = ("#nested-classes", "../hierarchy.html#")


class Page(HTMLParser):
    def __init__(self, path: Path) -> None:
        super().__init__()
        self.anchors = {"", "top"}
        self.links: set[str] = set()
        self.loads: set[str] = set()
        self.feed(path.read_text(errors="replace"))

    def handle_starttag(self, tag: str, given: list[tuple[str, str | None]]) -> None:
        attributes = {name: value or "" for name, value in given}
        self.anchors |= {attributes[name] for name in ("id", "name") if name in attributes}
        if tag == "a" and "href" in attributes:
            self.links.add(attributes["href"])
        if tag == "link" and attributes.get("rel") in ("stylesheet", "icon", "preload"):
            self.loads.add(attributes["href"])
        if tag in ("img", "script", "iframe", "source") and "src" in attributes:
            self.loads.add(attributes["src"])


pages = {path: Page(path) for path in sorted(folder.rglob("*.html"))}
broken = []
count = 0
for path, page in pages.items():
    for link in sorted(page.links | page.loads):
        count += 1
        parts = urlsplit(link)
        if parts.scheme or parts.netloc:
            if link in page.loads and (parts.netloc or parts.scheme.startswith("http")):
                broken.append(f"{path.relative_to(folder)}: is loaded from another host: {link}")
            continue
        base = folder if parts.path.startswith("/") else path.parent
        target = (base / unquote(parts.path).lstrip("/")).resolve() if parts.path else path
        target = target / "index.html" if target.is_dir() else target
        if not target.is_file():
            broken.append(f"{path.relative_to(folder)}: no such page: {link}")
        elif (
            target in pages
            and not link.startswith(FLAWS_OF_TOOLS)
            and unquote(parts.fragment) not in pages[target].anchors
        ):
            broken.append(f"{path.relative_to(folder)}: no such place in the page: {link}")
        elif (
            target.suffix == ".svg" and parts.fragment and f'id="{parts.fragment}"' not in target.read_text()
        ):
            broken.append(f"{path.relative_to(folder)}: no such drawing in the picture: {link}")
print("\n".join(broken), file=sys.stderr) if broken else print(f"{len(pages)} pages, {count} links")
sys.exit(bool(broken))
