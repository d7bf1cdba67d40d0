/** First stage: assigns each device to the grid cells that its surroundings touch. */
package io.furrow.analytics.collision.grid;
