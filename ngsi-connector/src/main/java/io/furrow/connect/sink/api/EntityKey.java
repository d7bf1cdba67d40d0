package io.furrow.connect.sink.api;

import io.furrow.model.event.FiwareScope;

/** An entity of the context broker, whatever its type. */
public record EntityKey(FiwareScope scope, String id) {}
