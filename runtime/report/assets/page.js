// Brings a page to life: each piece of data is drawn where it stands, the mechanism as another player shows it, if one is given.

function enliven(root, before) {
  for (const data of root.querySelectorAll("script[data-kind]")) {
    const content = JSON.parse(data.textContent);
    const box = data.parentElement;
    if (data.dataset.kind === "table") addCopyButton(box, content);
    if (data.dataset.kind === "figure") drawFigure(content, box.querySelector(".drawing"));
    if (data.dataset.kind === "scene") box.player = showMechanism(content, box.querySelector(".drawing"), before);
  }
}
enliven(document);
// A link into folded details unfolds them; a printed page has them all.
const unfold = () => {
  const target = document.getElementById(location.hash.slice(1));
  if (target instanceof HTMLDetailsElement) target.open = true;
};
addEventListener("hashchange", unfold);
unfold();
for (const link of document.querySelectorAll("nav a")) link.addEventListener("click", () => setTimeout(unfold));
addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((own) => { own.open = true; }));
// What tests and other scripts wait for.
document.documentElement.dataset.drawn = "yes";
