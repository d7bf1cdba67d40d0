/** Pages of metrics in the text format of Prometheus. */
package io.furrow.http.prometheus;
