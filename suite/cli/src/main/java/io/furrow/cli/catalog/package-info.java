/** Prints the data catalog, and reads what is stored elsewhere. */
package io.furrow.cli.catalog;
