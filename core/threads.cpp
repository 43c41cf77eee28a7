#include "core/threads.h"

#include <condition_variable>
#include <vector>

namespace voussoir {
namespace {

/// Work that waits for help, or has some.
struct Offer {
  const std::function<void()>* work;
  int wanted;       ///< helpers that may still begin
  int helping = 0;  ///< that have begun
};

/// Threads that wait for offers.
class Helpers {
 public:
  ~Helpers() {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
    offered_.notify_all();
  }

  void help(int wanted, const std::function<void()>& work) {
    Offer offer{&work, wanted};
    std::unique_lock lock(mutex_);
    while (static_cast<int>(threads_.size()) < wanted) threads_.emplace_back([this] { wait(); });
    offers_.push_back(&offer);
    lock.unlock();
    for (int i = 0; i < wanted; ++i) offered_.notify_one();
    work();
    lock.lock();
    std::erase(offers_, &offer);
    left_.wait(lock, [&] { return offer.helping == 0; });
  }

 private:
  void wait() {
    std::unique_lock lock(mutex_);
    while (true) {
      offered_.wait(lock, [&] { return ended_ || !offers_.empty(); });
      if (ended_) return;
      Offer& offer = *offers_.back();  // the last one: what it is part of waits for it
      if (--offer.wanted == 0) offers_.pop_back();
      ++offer.helping;
      lock.unlock();
      (*offer.work)();
      lock.lock();
      if (--offer.helping == 0) left_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable offered_, left_;
  std::vector<Offer*> offers_;
  bool ended_ = false;
  std::vector<std::jthread> threads_;  // the last member: they end before what they look at
};

}  // namespace

void run_with_help(int helpers, const std::function<void()>& work) {
  if (helpers <= 0) return work();
  static Helpers waiting;
  waiting.help(helpers, work);
}

}  // namespace voussoir
