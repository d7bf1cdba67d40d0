/** The commands {@code ./furrow bench …}: start a measurement, and report. */
package io.furrow.bench.command;
