/** The job {@code normalize}: converts the context broker's native Kafka notifications to records of {@code data.raw}. */
package io.furrow.ingest.normalize;
