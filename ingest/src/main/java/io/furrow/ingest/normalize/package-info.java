/** The job {@code normalize}: the context broker's native Kafka notifications become the records of {@code data.raw}. */
package io.furrow.ingest.normalize;
