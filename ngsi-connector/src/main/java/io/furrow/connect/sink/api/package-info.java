/** Requests to a context broker, over NGSI-v2 or NGSI-LD. */
package io.furrow.connect.sink.api;
