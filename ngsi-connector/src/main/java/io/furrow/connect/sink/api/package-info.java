/** Changes of entities, and the requests that write them to a context broker, over NGSI-v2 or NGSI-LD. */
package io.furrow.connect.sink.api;
