/** Routes every event: parses and deduplicates it, assigns its domain and mission, and sends it to their topics. */
package io.furrow.ingest.route;
