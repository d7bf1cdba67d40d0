/** Reads the catalog, which ingest writes. */
package io.furrow.kafka.catalog;
