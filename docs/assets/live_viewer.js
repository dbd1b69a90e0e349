// The first page: a click on "Run it live" puts the viewer in the place of the film. Without scripts the link leads to
// the viewer's own page.
{
  const film = document.querySelector(".live");
  const open = film.querySelector("a");

  // Browsers load no modules from a folder of files.
  if (location.protocol === "file:") open.replaceWith("Where a web server shows this page, the viewer runs live here.");

  open.addEventListener("click", (event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    const viewer = document.createElement("figure");
    viewer.className = "live";
    viewer.innerHTML = `<iframe title="The viewer: spheres that move and touch" src="${open.href}" allow="fullscreen"></iframe>
      <figcaption><button type="button" class="md-button">Close it</button>
        <a class="md-button" href="${open.href}">Open it in a page of its own</a></figcaption>`;
    film.replaceWith(viewer);
    const frame = viewer.querySelector("iframe");
    // Keys go to the viewer.
    frame.addEventListener("load", () => frame.focus());
    viewer.querySelector("button").addEventListener("click", () => {
      viewer.replaceWith(film);
      open.focus();
    });
  });
}
