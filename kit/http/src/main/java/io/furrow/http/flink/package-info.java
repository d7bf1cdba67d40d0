/** The access rule for the REST API and web UI of Flink 2. */
package io.furrow.http.flink;
