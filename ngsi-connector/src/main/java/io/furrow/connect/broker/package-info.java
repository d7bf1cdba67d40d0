/** REST requests to a context broker, their outcomes, and the options of the connection. */
package io.furrow.connect.broker;
