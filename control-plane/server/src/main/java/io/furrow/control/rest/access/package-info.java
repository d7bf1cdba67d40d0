/** Who may do what with the REST API, over TLS or without, and how requests are refused. */
package io.furrow.control.rest.access;
