/** Files of the page and of its libraries. */
package io.furrow.dashboard.page;
