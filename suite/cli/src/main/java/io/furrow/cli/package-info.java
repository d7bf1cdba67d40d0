/**
 * The commands of {@code ./furrow} that start nothing.
 *
 * <p><b>In</b>: arguments, answers of the control plane's REST API, topics, stored missions.
 *
 * <p><b>Out</b>: tables, JSON, exported files, requests to the control plane, redriven records.
 *
 * <p><b>Must not know</b>: the suite and its engines: every command works with parts that run elsewhere.
 */
package io.furrow.cli;
