// Runs before the first paint, so that the page does not flash in another color scheme: sets the chosen one, else that of the system.
(() => {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  const apply = () => {
    document.documentElement.dataset.scheme = localStorage.getItem('furrow-scheme') ?? (dark.matches ? 'dark' : 'light');
    window.dispatchEvent(new Event('schemechange'));
  };
  apply();
  dark.addEventListener('change', apply);
  window.addEventListener('schemechosen', apply);
  // chosen in another tab
  window.addEventListener('storage', ({ key }) => key === 'furrow-scheme' && apply());
})();
