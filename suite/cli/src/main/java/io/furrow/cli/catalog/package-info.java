/** Reads and prints the data catalog. */
package io.furrow.cli.catalog;
