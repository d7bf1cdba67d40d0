/** Maintains the catalog: types of entities, their attributes, missions and images, counted as events pass. */
package io.furrow.ingest.catalog;
