/**
 * The command {@code ./furrow}: the whole suite in one JVM, and commands for what runs elsewhere.
 *
 * <p><b>In</b>: options of the command line.
 *
 * <p><b>Out</b>: running engines, jobs, connectors and control plane; text, tables and JSON.
 *
 * <p><b>Must not know</b>: how any part works: it only starts, stops and asks them.
 */
package io.furrow.launcher;
