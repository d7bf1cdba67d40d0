/** Publishes domains and missions as entities of the context broker. */
package io.furrow.control.context;
