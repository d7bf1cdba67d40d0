/** Third stage: joins the observations of a pair into encounters. */
package io.furrow.analytics.collision.encounter;
