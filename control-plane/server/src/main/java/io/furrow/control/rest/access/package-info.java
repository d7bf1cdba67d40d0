/** Controls access to the REST API: tokens, roles, TLS, and responses to rejected requests. */
package io.furrow.control.rest.access;
