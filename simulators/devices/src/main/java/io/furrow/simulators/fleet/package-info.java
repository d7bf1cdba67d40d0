/** A farm at work: who reports when, what, and over which connection. */
package io.furrow.simulators.fleet;
