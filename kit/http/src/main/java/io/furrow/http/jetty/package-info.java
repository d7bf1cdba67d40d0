/** The access rule for servers on Jetty 12. */
package io.furrow.http.jetty;
