/** Maintains the newest value of every attribute of every entity, on {@code data.latest}. */
package io.furrow.ingest.latest;
