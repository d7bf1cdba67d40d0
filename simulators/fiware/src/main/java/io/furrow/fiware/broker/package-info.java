/** The context broker: entities, queries, subscriptions and notifications. */
package io.furrow.fiware.broker;
