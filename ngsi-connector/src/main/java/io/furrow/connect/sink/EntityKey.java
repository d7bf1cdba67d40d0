package io.furrow.connect.sink;

import io.furrow.model.event.FiwareScope;

/** An entity of the context broker, whatever its type. */
record EntityKey(FiwareScope scope, String id) {}
