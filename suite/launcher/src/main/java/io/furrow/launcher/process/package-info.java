/** Concerns of the process rather than of a part of the suite: log, progress on the terminal, requests to servers. */
package io.furrow.launcher.process;
