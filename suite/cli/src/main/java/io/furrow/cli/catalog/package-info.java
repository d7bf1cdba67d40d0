/** The data catalog, read and printed. */
package io.furrow.cli.catalog;
