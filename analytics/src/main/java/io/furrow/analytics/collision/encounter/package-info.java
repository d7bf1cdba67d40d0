/** Third stage: joins what the cells observed of a pair into encounters. */
package io.furrow.analytics.collision.encounter;
