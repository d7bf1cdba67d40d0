/** The real engines in one JVM, on loopback: used by the one-command start and by tests, never by what runs on a cluster. */
package io.furrow.embedded;
