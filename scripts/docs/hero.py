"""The first screen of the site's first page, made of what docs/index.md begins with.

That is a title, a sentence, a picture and a table of languages, in this order; GitHub shows the same page as it is. The
picture gives way to a live one if scripts/docs.sh builds that.
"""

import html
import re
from pathlib import Path

docs = Path(__file__).resolve().parents[2] / "docs"
BEGIN = re.compile(
    r"\s*(?P<title><h1.*?</h1>)\s*<p>(?P<sentence>.*?)</p>\s*<p>(?P<film><picture>.*?</picture>)</p>\s*", re.S
)
TABLE = re.compile(
    r"<h2 id=\"(?P<anchor>[^\"]+)\"[^>]*>(?:(?!<h2).)*?</h2>\s*<table>(?P<table>.*?)</table>\s*", re.S
)
ROW = re.compile(r"<tr>\s*" + r"\s*".join([r"<td>(.*?)</td>"] * 4) + r"\s*</tr>", re.S)
TAG = re.compile(r"<[^>]+>")
STILL = "The picture is a recording: this site was built without Emscripten."
LOADING = "The picture is a recording until the library has been loaded."
BESIDE = (
    "A loop looks 60 times a second, and misses what happens in between. Kinesphere asks a body where it is "
    "only when that can matter, and misses nothing."
)


def text_of(markup: str) -> str:
    return html.unescape(TAG.sub("", markup)).strip()


def check_commands(language: str, install: str, page: str) -> None:
    """Raises an error unless the page that a row leads to has all commands of the row."""
    known = (docs / page).read_text()
    for command in install.split(" && "):
        if command not in known:
            raise ValueError(f"index.md: docs/{page} does not have the command of {language}: {command}")


def tabs(table: str) -> str:
    """A tab for each row: language, install line, line of code, link to more."""
    inputs, labels, blocks = [], [], []
    for number, row in enumerate(ROW.finditer(table), 1):
        language, install, code, more = row.groups()
        page = re.search(r'href="([\w./-]+)\.html', more)
        if page is None:
            raise ValueError(f"index.md: the row of {text_of(language)} leads to no page")
        check_commands(text_of(language), text_of(install), page[1] + ".md")
        checked = " checked" if number == 1 else ""
        inputs.append(f'<input{checked} id="__tabbed_1_{number}" name="__tabbed_1" type="radio">')
        labels.append(f'<label for="__tabbed_1_{number}">{text_of(language)}</label>')
        lines = text_of(install).replace(" && ", "\n")
        blocks.append(
            f'<div class="tabbed-block"><div class="hero-tab"><pre><code>{html.escape(text_of(code))}</code></pre>'
            f"<pre><code>{html.escape(lines)}</code></pre><p>{more}</p></div></div>"
        )
    if not blocks:
        raise ValueError("index.md: the table of languages has no row with four cells")
    return (
        f'<div class="tabbed-set tabbed-alternate" data-tabs="1:{len(blocks)}">{"".join(inputs)}'
        f'<div class="tabbed-labels">{"".join(labels)}</div><div class="tabbed-content">{"".join(blocks)}</div></div>'
    )


def split(content: str, version: str, is_live: bool, has_viewer: bool) -> tuple[str, str]:
    """Returns the first screen, and what follows it on the page."""
    begin = BEGIN.match(content)
    table = TABLE.search(content)
    if begin is None or table is None:
        raise ValueError(
            "index.md: it has to begin with a title, a sentence, a picture and a table of languages"
        )
    title = re.sub(r'<a class="headerlink".*?</a>', "", begin["title"]).replace(
        "</h1>", f' <small class="hero-version">{version}</small></h1>'
    )
    viewer = '<p><a href="viewer/index.html">In three dimensions: the viewer</a></p>' * has_viewer
    hero = f"""<section class="hero md-typeset" aria-label="Kinesphere at a glance">
<div class="hero-head"><div>{title}<p>{begin["sentence"]}</p></div>
<p class="hero-buttons"><a class="md-button md-button--primary" href="lessons/first-contact.html">Begin: thirty lines</a>
<a class="md-button" href="two-bodies.html">See how it works</a></p></div>
<div class="hero-live"><div class="live" data-live="discs">{begin["film"]}</div>
<div class="hero-numbers"><p>{BESIDE}</p><div data-live="numbers"></div></div>
<div class="hero-controls" data-live="controls"></div>
<div class="hero-legend"><div data-live="legend"></div><p class="live-note" data-live="note">{LOADING if is_live else STILL}</p>{viewer}</div></div>
<div class="hero-install" id="{table["anchor"]}">{tabs(table["table"])}</div>
</section>"""
    return hero, content[begin.end() : table.start()] + content[table.end() :]
