/**
 * The command {@code ./furrow}: the whole suite in one JVM, and commands for parts that run elsewhere.
 *
 * <p><b>In</b>: options of the command line.
 *
 * <p><b>Out</b>: running engines, jobs, connectors and control plane; text, tables and JSON.
 *
 * <p><b>Must not know</b>: the internals of any part: it only starts, stops and queries them.
 */
package io.furrow.launcher;
