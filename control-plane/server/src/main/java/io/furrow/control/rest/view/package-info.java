/** What the REST API reads: a view of the managers' topics, stored events and markers; and the client that sends commands. */
package io.furrow.control.rest.view;
