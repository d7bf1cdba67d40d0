/** The job {@code ingest}: from {@code data.raw} to the topics of domains and missions. */
package io.furrow.ingest.route;
