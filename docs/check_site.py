"""Checks a built site: every link within it leads to a file that is there, and to a place in it that is there.

usage: check_site.py FOLDER. Prints what is broken, a line each, and leaves with status 1 if anything is. Links to other
sites are not followed.
"""

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.places, self.links = {""}, []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.places |= {attributes.get("id") or "", (attributes.get("name") if tag == "a" else "") or ""}
        self.links += [attributes[key] for key in ("href", "src") if attributes.get(key)]


def broken_links(folder):
    pages = {path: Page(path.read_text(errors="replace")) for path in sorted(folder.rglob("*.html"))}
    for path, page in pages.items():
        if path.name == "404.html":  # its links are from the root of a server
            continue
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() if parts.path else path.resolve()
            if target.is_dir():
                target /= "index.html"
            place = urllib.parse.unquote(parts.fragment)
            if not target.exists():
                yield f"{path.relative_to(folder)}: {link}: there is no such file"
            elif target in pages and place not in pages[target].places:
                yield f"{path.relative_to(folder)}: {link}: there is no such place"


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    broken = sorted(set(broken_links(folder)))
    print("\n".join(broken) if broken else f"every link within {folder.name} leads somewhere")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
