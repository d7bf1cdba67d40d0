/** The commands {@code ./furrow bench …}: start what is measured, and report. */
package io.furrow.bench.command;
