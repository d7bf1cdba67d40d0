/** HTTP server of the source: access, limits, and the answer once records are durable. */
package io.furrow.connect.source.http;
