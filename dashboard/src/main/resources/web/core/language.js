/** The language of the page: as chosen in the settings, else the first of the browser's that the page has. */

export const languages = { en: 'English', es: 'Español' };
const locales = { en: 'en-GB', es: 'es-ES' };

export const language = [localStorage.getItem('furrow-language'), ...navigator.languages.map((tag) => tag.slice(0, 2))].find((each) => Object.hasOwn(languages, each)) ?? 'en';
export const locale = locales[language];
document.documentElement.lang = language;

/** The place, the scope and what is selected are in the address, so that they are retained. */
export function chooseLanguage(name) {
  localStorage.setItem('furrow-language', name);
  location.reload();
}
