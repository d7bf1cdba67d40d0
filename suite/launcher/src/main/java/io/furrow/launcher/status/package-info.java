/** What the terminal shows while the suite runs. */
package io.furrow.launcher.status;
