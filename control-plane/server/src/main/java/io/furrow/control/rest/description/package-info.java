/** The description of the API, and what requests are checked against. */
package io.furrow.control.rest.description;
