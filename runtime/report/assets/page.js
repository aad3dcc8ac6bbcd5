// Brings the page to life: each piece of data is drawn where it stands.

for (const data of document.querySelectorAll("script[data-kind]")) {
  const content = JSON.parse(data.textContent);
  const box = data.parentElement;
  if (data.dataset.kind === "table") addCopyButton(box, content);
  if (data.dataset.kind === "figure") drawFigure(content, box.querySelector(".drawing"));
  if (data.dataset.kind === "scene") showMechanism(content, box.querySelector(".drawing"));
}
// What tests and other scripts wait for.
document.documentElement.dataset.drawn = "yes";
