/** What counts as an encounter: the rules of all stages. */
package io.furrow.analytics.collision.rules;
