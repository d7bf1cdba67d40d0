/** What belongs to the process and to no part of the suite: its log, its progress on the terminal, its requests to servers. */
package io.furrow.launcher.process;
