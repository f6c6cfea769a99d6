// What is folded away opens for a link that leads to it, and on paper.

/// Opens what hides an element, and the fold that it consists of.
function reveal(element) {
  for (let fold = element?.closest('details'); fold; fold = fold.parentElement.closest('details')) {
    fold.open = true;
  }
  const own = element?.querySelector(':scope > details:first-child, :scope > .index');
  if (own) own.open = true;
}

/// Opens what the page's address names.
function revealTarget() {
  const element = location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!element) return;
  reveal(element);
  element.scrollIntoView();
}

window.addEventListener('hashchange', revealTarget);
revealTarget();
document.addEventListener('click', ({target}) => {
  // A second press of the same link changes no address.
  const link = target.closest?.('a[href^="#"]');
  if (link && link.hash === location.hash) revealTarget();
});

let openedForPrint = [];
window.addEventListener('beforeprint', () => {
  openedForPrint = [...document.querySelectorAll('details:not([open])')];
  for (const fold of openedForPrint) fold.open = true;
});
window.addEventListener('afterprint', () => {
  for (const fold of openedForPrint) fold.open = false;
});
