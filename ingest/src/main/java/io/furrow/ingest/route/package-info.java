/** What becomes of every event: recognized, passed once, given its domain and mission, brought to their topics. */
package io.furrow.ingest.route;
