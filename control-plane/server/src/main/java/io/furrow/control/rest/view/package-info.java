/** Provides the data of the REST API: a view of the managers' topics, recorded events and markers; and sends commands. */
package io.furrow.control.rest.view;
