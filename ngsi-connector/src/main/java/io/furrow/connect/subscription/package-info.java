/** Maintains the source's own subscriptions in a context broker. Independent of Connect. */
package io.furrow.connect.subscription;
