// What the theme leaves out for those who use a keyboard or a screen reader: parts that scroll can be reached, and the
// search has a name.
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
  reachable();
  addEventListener("resize", reachable);
});
