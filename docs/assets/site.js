// What the theme leaves out, and the reference of C++.

// The index of the search is larger than all else that a page loads. It is fetched once somebody searches: the theme takes
// it from this promise.
var __search = {
  // World::ask is a word of World and a word ask. The rest is what the theme does: a quoted phrase has all its words.
  transform: (words) => words.replaceAll("::", " ").split(/"([^"]+)"/g)
    .map((part, k) => k % 2 === 1 ? part.replace(/^\b|\s+/g, " +") : part).join("").replace(/"|(?:^|\s+)[*+\-:^~]+(?=\s+|$)/g, "").trim(),
  index: new Promise((resolve) => {
    const wanted = new URLSearchParams(location.search).has("q");
    const base = new URL("..", document.currentScript.src);
    const fetchIndex = () => resolve(fetch(new URL("search/search_index.json", base)).then((response) => response.json()));
    const isSearch = ({ target }) => target.matches?.("[data-md-component='search-query'], [for='__search'], #__search");
    if (wanted) fetchIndex();
    else for (const kind of ["focusin", "change"]) addEventListener(kind, (event) => { if (isSearch(event)) fetchIndex(); });
  }),
};

// For those who use a keyboard or a screen reader: parts that scroll can be reached, and the search has a name.
addEventListener("load", () => {
  const scrolling = ".md-typeset__scrollwrap, pre > code, .md-search__scrollwrap, .fragment, .memproto, .memberdecls, .memdoc table";
  const search = document.querySelector(".md-search");
  search?.setAttribute("aria-label", search.querySelector("input").getAttribute("aria-label"));
  const reachable = () => {
    for (const part of document.querySelectorAll(scrolling)) {
      const scrolls = part.scrollWidth > part.clientWidth || part.matches(".md-search__scrollwrap");
      if (scrolls) part.tabIndex = 0;
      else part.removeAttribute("tabindex");
    }
  };
  // On a phone a table that is too wide becomes a list: each row with its first cell on top, and the names of the others.
  const list = () => {
    for (const table of document.querySelectorAll(".md-typeset__scrollwrap table")) {
      table.removeAttribute("data-list");
      const frame = table.closest(".md-typeset__scrollwrap");
      if (innerWidth >= 720 || frame.scrollWidth <= frame.clientWidth) continue;
      table.setAttribute("data-list", "");
      const names = Array.from(table.querySelectorAll("thead th"), (cell) => cell.textContent);
      for (const row of table.querySelectorAll("tbody tr"))
        for (const [k, cell] of [...row.cells].entries()) if (k > 0 && names[k]) cell.dataset.name = `${names[k]}: `;
    }
  };
  const fit = () => { list(); reachable(); };
  fit();
  addEventListener("resize", fit);
});
