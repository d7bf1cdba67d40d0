/** All parts of the suite in one JVM: the order in which they start and stop, and the locations of their data. */
package io.furrow.launcher.suite;
