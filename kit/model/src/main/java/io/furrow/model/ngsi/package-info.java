/** NGSI entities as the context broker reports them, and their one normal form inside Furrow. */
package io.furrow.model.ngsi;
