/** The rules of encounters, for all stages. */
package io.furrow.analytics.collision.rules;
