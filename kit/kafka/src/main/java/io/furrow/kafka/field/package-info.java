/** Fields on {@code service.fields}: read, written and compared. */
package io.furrow.kafka.field;
