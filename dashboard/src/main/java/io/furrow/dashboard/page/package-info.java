/** The files of the page and of the libraries that it uses. */
package io.furrow.dashboard.page;
