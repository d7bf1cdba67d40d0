/** Serves the REST API: commands become requests to the managers, reads come from a view of their topics. */
package io.furrow.control.rest;
