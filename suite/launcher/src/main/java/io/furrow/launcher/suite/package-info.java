/** All parts of the suite in one JVM: in which order they start and stop, and where they store their data. */
package io.furrow.launcher.suite;
