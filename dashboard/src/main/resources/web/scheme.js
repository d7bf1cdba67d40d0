// Runs before the first paint, so that the page does not flash in another color scheme.
(() => {
  const chosen = localStorage.getItem('furrow-scheme');
  if (chosen) {
    document.documentElement.dataset.scheme = chosen;
  }
})();
