/** Keeps the source's own subscriptions in a context broker as they should be. Knows nothing of Connect. */
package io.furrow.connect.subscription;
