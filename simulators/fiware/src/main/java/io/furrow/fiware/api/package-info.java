/** NGSI-v2 over HTTP: the resources, and how requests are read. */
package io.furrow.fiware.api;
