/** Shows the running suite on the terminal. */
package io.furrow.launcher.status;
