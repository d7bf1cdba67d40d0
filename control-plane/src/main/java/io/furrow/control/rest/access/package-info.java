/** Authentication and authorization of the REST API, and TLS. */
package io.furrow.control.rest.access;
