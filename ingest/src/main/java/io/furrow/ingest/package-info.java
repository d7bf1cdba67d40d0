/** The jobs {@code ingest} and {@code normalise}, each on a page; their stages and branches have a package each. */
package io.furrow.ingest;
