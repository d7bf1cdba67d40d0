/** Reads, writes and compares fields on {@code service.fields}. */
package io.furrow.kafka.field;
