// Before the first paint, so that a chosen scheme does not flash in the other one.
(() => {
  const chosen = localStorage.getItem('furrow-scheme');
  if (chosen) {
    document.documentElement.dataset.scheme = chosen;
  }
})();
